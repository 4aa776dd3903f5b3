"""What is integrated: Hamiltonian problems, built in or of your own, and the harmonic
oscillator.
"""
