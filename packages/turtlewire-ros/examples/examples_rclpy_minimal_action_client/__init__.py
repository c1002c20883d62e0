"""ROS 2's minimal examples: Clients of the action server for Fibonacci sequences.

=======================  ==================================================
module                   contents
=======================  ==================================================
`client`                 sends a goal and waits for its result
`client_asyncio`         awaits one goal, then two at a time, in asyncio
`client_cancel`          cancels its goal after two seconds
`client_not_composable`  one function that spins until each answer has arrived
=======================  ==================================================
"""
