"""``turtlewire mcp``: tools with which an assistant looks at a network, over the MCP protocol.

An assistant reads the names, arguments and docstrings of the tools, and gets JSON or the text of an
error. All of them share one node; each subscribes only while it is called. What needs the SDK is
imported when the command runs, because the SDK takes a second to load.

===============  ==========================================================================
module           contents
===============  ==========================================================================
`server`         the MCP server: its tools, and the standard streams that it speaks on
`looking`        the tools that only read
`acting`         the tools that publish, drive and call services
`permissions`    the names that ``--allow`` gave; limits of calls and answers; errors
`network`        the connection: waits for the graph, types of topics, names that are near
`plots`          a numeric field of a topic, and its picture
===============  ==========================================================================
"""
