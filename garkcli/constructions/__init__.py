"""Methods made from methods: compositions, adjoints, splittings, extrapolation, multirate
methods.
"""
