package org.example.ode;

/** Ralston's method. */
public class Ralston<T extends Element<T>> extends Integrator<T> {

    @Override
    public T[][] getA() {
        final T[][] a = MathArrays.buildArray(getField(), 1, -1);
        for (int i = 0; i < a.length; ++i) {
            a[i] = MathArrays.buildArray(getField(), i + 1);
        }
        a[0][0] = fraction(getField(), 2, 3);
        return a;
    }

    @Override
    public T[] getB() {
        final T[] b = MathArrays.buildArray(getField(), 2);
        b[0] = getField().getOne().divide(4);
        b[1] = b[0].multiply(3);
        return b;
    }

    @Override
    public int getOrder() {
        return 2;
    }
}
