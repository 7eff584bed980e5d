"""The tiers of the paper, one file a tier, in its words."""
