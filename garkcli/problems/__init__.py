"""Problems: Hamiltonian ones, right-hand sides, built in or of your own, and the harmonic
oscillator.
"""
