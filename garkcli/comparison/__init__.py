"""Comparison of two methods: their differences, and the sense in which they are the same."""
