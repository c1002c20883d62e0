"""The graph page: nodes, topics and their mismatches, live or as a file.

===============  ================================================================
module           contents
===============  ================================================================
`picture`        `Picture`: the graph at one moment, with its mismatches
`selection`      which nodes and topics of it are shown
`diagram`        the boxes and arrows of a picture
`layers`         the column of each box, and the order in it
`layout`         the positions of boxes and the paths of arrows
`columns`        the positions within one connected part of the diagram
`files`          the picture as SVG, Graphviz and JSON
`measuring`      rates and values of the topics that pages ask for
`page_commands`  what the page may send
`session`        one page: what it asks for, and what it does not have yet
`graph_page`     `GraphPage`: serves the page
===============  ================================================================
"""
