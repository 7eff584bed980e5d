"""Parts of the giant-route heuristic: tours, their local search and their crossover."""
