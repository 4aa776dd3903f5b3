"""The room of N-trees: one tree (``tree``), all trees (``table``), counts, notation, drawings.

Only the tree table and its users need numpy; ``listing`` lists few trees without.
"""
