"""The fleet at sea: AUVs carry a plan out in an ocean nobody forecast, and agree on changes.

`simulation` is where to start reading. Who steers is one of `planners`; what an AUV reckons with
on board is in `courses`, how AUVs talk and share nodes out in `agents`, and what nobody could do
better in `bounds`.
"""
