//! Tableaus of explicit methods.

pub struct Tableau {
    pub a: Vec<Vec<f64>>,
    pub b: Vec<f64>,
    pub c: Vec<f64>,
    pub order: usize,
}

impl Tableau {
    /// Kutta's method.
    pub fn kutta() -> Self {
        let mut a = vec![vec![0.0; 3]; 3];
        a[1][0] = 0.5;
        a[2][0] = -1.0;
        a[2][1] = 2.0;
        let b = [1.0, 4.0, 1.0].map(|x| x / 6.0).to_vec();
        Self { a, b, c: vec![0.0, 0.5, 1.0], order: 3 }
    }
}

struct Heun;

impl Method for Heun {
    const ORDER: u8 = 2;
    const A: &'static [&'static [f64]] = &[&[], &[1.0]];
    const B: [f64; 2] = [0.5, 0.5];
}

#[cfg(test)]
#[allow(dead_code)] // in order
mod tests {
    #[test]
    fn weights_are_checked() {
        let a = [[0.0, 0.0], [1.0, 0.0]];
        let b = [0.5, 0.25];
        let c = [0.0, 1.0];
        assert!(Tableau::checked(a, b, c).is_err());
    }
}
