"""Objects of rclpy as arguments and results of remote calls, beside XML-RPC's own types."""
