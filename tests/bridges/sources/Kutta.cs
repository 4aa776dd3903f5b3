namespace Ode
{
    /// <summary>Kutta's method of order 3.</summary>
    public class Kutta : Integrator
    {
        public override int Order => 3;
        protected override double[,] A { get { return new double[,] { { 0, 0, 0 }, { 0.5, 0, 0 }, { -1, 2, 0 } }; } }
        protected override double[] B => new[] { 1 / 6.0, 2 / 3.0, 1 / 6.0 };
        protected override double[] C { get; } = { 0, 0.5, 1 };
    }

    public static class Methods
    {
        public static Tableau Ralston()
        {
            var a = new double[2, 2];
            a[1, 0] = 2d / 3;
            return new Tableau { A = a, B = new List<double> { 0.25, 0.75 }, Order = 2 };
        }
    }
}
