"""What no fleet at sea can do better: clairvoyant plans, and bounds on online policies."""
