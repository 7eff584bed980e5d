"""Time-optimal paths between two points, and the references that they are held to."""
