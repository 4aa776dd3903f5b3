"""Problems: Hamiltonian ones, right-hand sides, and the harmonic oscillator."""
