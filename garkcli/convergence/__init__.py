"""Errors over step sizes, and the order they show."""
