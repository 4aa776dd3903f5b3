"""What is integrated: Hamiltonian problems, built in or of one's own, and the harmonic
oscillator.
"""
