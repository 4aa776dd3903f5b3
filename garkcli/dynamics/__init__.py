"""Methods at work: a linear test problem, one exact step, convergence and energy.

Only ``energy.drift`` needs numpy, and imports it when it is called.
"""
