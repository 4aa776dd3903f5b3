"""Methods at work: test problems, steps, convergence and energy.

The oscillator's step map is linear and exact; its modules import neither numpy nor sympy, ``energy.drift`` apart.
Nonlinear problems are differentiated by sympy and stepped with numpy's help, both imported when they are used.
"""
