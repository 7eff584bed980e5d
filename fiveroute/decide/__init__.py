"""What is decided before departure: how many AUVs, when, how fast, and how cautiously."""
