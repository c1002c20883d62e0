"""The graph page: nodes, topics and their mismatches, live or as a file.

===============  ================================================================
module           contents
===============  ================================================================
`picture`        `Picture`: the graph at one moment, with its mismatches; what is shown
`layers`         the column of each box, the order in it, and the positions
`layout`         the boxes and arrows of a picture; their positions and paths
`files`          the picture as SVG, Graphviz and JSON
`measuring`      rates and values of the topics that pages ask for
`session`        one page: what it may send, asks for, and does not have yet
`graph_page`     `GraphPage`: serves the page
===============  ================================================================
"""
