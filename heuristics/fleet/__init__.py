"""Parts of the fleet search: the stops, their chains, removal, insertion, annealing."""
