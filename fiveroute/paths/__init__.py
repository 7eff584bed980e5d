"""Time-optimal paths between two points: differential evolution, and the references it is held to."""
