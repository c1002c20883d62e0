"""Checks of the installation, the graph and the transforms, with advice.

The command ``turtlewire doctor``, ``ros2 doctor``, lessons and classes print these findings.

===================  ============================================================
module               contents
===================  ============================================================
`examination`        runs all checks, and prints the findings
`finding`            one finding: what is wrong and what to do
`fast_dds_findings`  nodes on Fast DDS, seen from Cyclone DDS; those that share memory
`fast_dds_search`    asks participants on Fast DDS how they receive; packets
`setup_findings`     checks of the installation, the environment and the network
`graph_findings`     checks of nodes and topics
`tf_findings`        checks of the published transforms, and of gaps in them
`tf_traffic`         the publishers of transforms during the checks
`network`            sockets of other domains, and multicast
===================  ============================================================
"""
