"""Checks of the installation, the graph and the transforms, in words that say what to do.

The command ``turtlewire doctor``, ``ros2 doctor``, lessons and classes print these findings.

===================  ============================================================
module               what it holds
===================  ============================================================
`examination`        runs all checks, and prints the findings
`finding`            one finding: what is wrong and what to do
`fast_dds_findings`  nodes on Fast DDS, seen from Cyclone DDS
`fast_dds_search`    asks participants on Fast DDS how they receive
`announcements`      the packets of this question and of its answers
`shared_memory`      processes of this host that share memory through Fast DDS
`setup_findings`     checks of the installation, the environment and the network
`graph_findings`     checks of nodes and topics
`tf_findings`        checks of the published transforms
`tf_gaps`            transforms that are missing from a rhythm
`tf_traffic`         who published which transforms during the checks
`discovery`          waits for the graph
`network`            sockets of other domains, and multicast
===================  ============================================================
"""
