"""Who steers the fleet: the five-tiered planner and those it is compared with, one a file."""
