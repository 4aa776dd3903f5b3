"""Methods made from methods: compositions, splittings, extrapolation, multirate methods."""
