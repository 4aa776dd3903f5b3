package ode

// Tableau of a method with its order.
type Tableau struct {
	A     [][]float64
	B, C  []float64
	Order int
}

// Kutta is Kutta's method of order 3.
var Kutta = Tableau{
	A:     [][]float64{{}, {1.0 / 2}, {-1, 2}},
	B:     []float64{1.0 / 6, 2.0 / 3, 1.0 / 6},
	C:     []float64{0, 0.5, 1},
	Order: 3,
}

func ralston() (a *mat.Dense, b []float64) {
	a = mat.NewDense(2, 2, nil)
	b = []float64{1: 0.75, 0: 0.25}
	a.Set(1, 0, 2.0/3)
	return a, b
}
