"""gark: order conditions and design of generalized additive Runge-Kutta methods, decided exactly."""

__version__ = "0.1.0"
