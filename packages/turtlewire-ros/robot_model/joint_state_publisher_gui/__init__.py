"""The joint state publisher with a page in the browser: a slider or a dial for each joint.

===========================  ==================================
module                       contents
===========================  ==================================
`joint_state_publisher_gui`  `JointStatePublisherGui`, the node
`page_commands`              the commands of the page
`screen`                     serves the page
`sliders`                    positions, shared by node and page
===========================  ==================================
"""
