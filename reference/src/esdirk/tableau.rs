//! Coefficients of two ESDIRK methods. Both are L-stable and stiffly accurate; their first stage is explicit and their
//! stages have order 2.

/// Coefficients of a method. All slices have one entry per stage, or one row per stage.
#[derive(Debug)]
pub(crate) struct Tableau {
    /// Power of the step length to which the estimated error is proportional.
    pub(super) error_order: u8,
    /// Diagonal coefficient of the implicit stages.
    pub(super) gamma: f64,
    /// Coefficients below the diagonal. The last stage is the end of the step.
    pub(super) coefficients: &'static [&'static [f64]],
    /// Times of the stages, as fractions of the step.
    pub(super) times: &'static [f64],
    /// Weights of the stages in the error estimate: the solution minus the solution of the embedded method.
    pub(super) error_weights: &'static [f64],
    /// Maximum number of earlier stages from which a stage is predicted: few for rates that jump, many for smooth ones.
    pub(super) predicting: usize,
}

impl Tableau {
    pub(super) fn stages(&self) -> usize {
        self.times.len()
    }
}

/// Diagonal coefficient of [`ESDIRK3`]: a root of `6 x^3 - 18 x^2 + 9 x - 1`.
const GAMMA_3: f64 = 0.435_866_521_508_459;

/// ESDIRK 3/4: order 3 with an embedded method of order 4 (Jørgensen, Kristensen, Thomsen: A Family of ESDIRK
/// Integration Methods, arXiv:1803.01613). For equations with few continuous derivatives.
pub(crate) const ESDIRK3: Tableau = Tableau {
    error_order: 4,
    gamma: GAMMA_3,
    coefficients: &[
        &[],
        &[GAMMA_3],
        &[0.140_737_774_724_706_2, -0.108_365_551_381_320_8],
        &[
            0.102_399_400_619_911,
            -0.376_878_452_255_556_1,
            0.838_612_530_127_186_1,
        ],
    ],
    times: &[0.0, 2.0 * GAMMA_3, 0.468_238_744_851_844_4, 1.0],
    error_weights: &[
        -0.054_625_497_240_413_94,
        -0.494_208_893_625_994_96,
        0.221_934_499_735_064_66,
        0.326_899_891_131_344_27,
    ],
    predicting: 2,
};

/// Diagonal coefficient of [`ESDIRK5`].
const GAMMA_5: f64 = 23.0 / 125.0;

/// Times of the inner stages of [`ESDIRK5`].
const TIME_2: f64 = 7_121_331_996_143.0 / 11_335_814_405_378.0;
const TIME_3: f64 = 49.0 / 353.0;
const TIME_4: f64 = 3_706_679_970_760.0 / 5_295_570_149_437.0;
const TIME_5: f64 = 347.0 / 382.0;

/// Coefficients of the inner stages of [`ESDIRK5`], except those of the first stage.
const STAGE_2: f64 = 791_020_047_304.0 / 3_561_426_431_547.0;
const STAGE_3: [f64; 2] = [
    -158_159_076_358.0 / 11_257_294_102_345.0,
    -85_517_644_447.0 / 5_003_708_988_389.0,
];
const STAGE_4: [f64; 3] = [
    -1_653_327_111_580.0 / 4_048_416_487_981.0,
    1_514_767_744_496.0 / 9_099_671_765_375.0,
    14_283_835_447_591.0 / 12_247_432_691_556.0,
];
const STAGE_5: [f64; 4] = [
    -4_540_011_970_825.0 / 8_418_487_046_959.0,
    -1_790_937_573_418.0 / 7_393_406_387_169.0,
    10_819_093_665_085.0 / 7_266_595_846_747.0,
    4_109_463_131_231.0 / 7_386_972_500_302.0,
];

/// Weights of the solution and of the embedded solution of [`ESDIRK5`], except those of the first stage.
const SOLUTION: [f64; 6] = [
    -188_593_204_321.0 / 4_778_616_380_481.0,
    2_809_310_203_510.0 / 10_304_234_040_467.0,
    1_021_729_336_898.0 / 2_364_210_264_653.0,
    870_612_361_811.0 / 2_470_410_392_208.0,
    -1_307_970_675_534.0 / 8_059_683_598_661.0,
    GAMMA_5,
];
const EMBEDDED: [f64; 6] = [
    -582_099_335_757.0 / 7_214_068_459_310.0,
    615_023_338_567.0 / 3_362_626_566_945.0,
    3_192_122_436_311.0 / 6_174_152_374_399.0,
    6_156_034_052_041.0 / 14_430_468_657_929.0,
    -1_011_318_518_279.0 / 9_693_750_372_484.0,
    1_914_490_192_573.0 / 13_754_262_428_401.0,
];

/// ESDIRK5(4)7L\[2\]SA2: order 5 with an embedded method of order 4 (Kennedy, Carpenter: Diagonally implicit
/// Runge-Kutta methods for stiff ODEs, Applied Numerical Mathematics 146, 2019). For smooth equations.
pub(crate) const ESDIRK5: Tableau = Tableau {
    error_order: 5,
    gamma: GAMMA_5,
    coefficients: &[
        &[],
        &[GAMMA_5],
        &[TIME_2 - GAMMA_5 - STAGE_2, STAGE_2],
        &[TIME_3 - GAMMA_5 - sum(&STAGE_3), STAGE_3[0], STAGE_3[1]],
        &[
            TIME_4 - GAMMA_5 - sum(&STAGE_4),
            STAGE_4[0],
            STAGE_4[1],
            STAGE_4[2],
        ],
        &[
            TIME_5 - GAMMA_5 - sum(&STAGE_5),
            STAGE_5[0],
            STAGE_5[1],
            STAGE_5[2],
            STAGE_5[3],
        ],
        &[
            1.0 - sum(&SOLUTION),
            SOLUTION[0],
            SOLUTION[1],
            SOLUTION[2],
            SOLUTION[3],
            SOLUTION[4],
        ],
    ],
    times: &[0.0, 2.0 * GAMMA_5, TIME_2, TIME_3, TIME_4, TIME_5, 1.0],
    error_weights: &[
        sum(&EMBEDDED) - sum(&SOLUTION),
        SOLUTION[0] - EMBEDDED[0],
        SOLUTION[1] - EMBEDDED[1],
        SOLUTION[2] - EMBEDDED[2],
        SOLUTION[3] - EMBEDDED[3],
        SOLUTION[4] - EMBEDDED[4],
        SOLUTION[5] - EMBEDDED[5],
    ],
    predicting: 6,
};

const fn sum(terms: &[f64]) -> f64 {
    let (mut sum, mut k) = (0.0, 0);
    while k < terms.len() {
        sum += terms[k];
        k += 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A method with its diagonal coefficients.
    struct Whole {
        rows: Vec<Vec<f64>>,
        times: &'static [f64],
    }

    impl Whole {
        fn new(tableau: &Tableau) -> Self {
            let stages = tableau.stages();
            let mut rows = vec![vec![0.0; stages]; stages];
            for (stage, (row, below)) in rows.iter_mut().zip(tableau.coefficients).enumerate() {
                row[..below.len()].copy_from_slice(below);
                if stage > 0 {
                    row[stage] = tableau.gamma;
                }
            }
            Self {
                rows,
                times: tableau.times,
            }
        }

        /// Applies the coefficients to one value per stage.
        fn apply(&self, values: &[f64]) -> Vec<f64> {
            self.rows.iter().map(|row| dot(row, values)).collect()
        }

        /// Products over the stages of the elementary differentials of all rooted trees of an order, and the density
        /// `gamma` of each tree, by which its weighted sum is `1/gamma` (Hairer, Nørsett, Wanner, II.2).
        fn trees(&self, order: u8) -> Vec<(Vec<f64>, f64)> {
            let stages = self.times.len();
            if order == 1 {
                return vec![(vec![1.0; stages], 1.0)];
            }
            // A tree is a root with branches; the branches have at most the size of the branch before.
            let mut found = Vec::new();
            self.grow(
                order - 1,
                order - 1,
                (vec![1.0; stages], 1.0),
                &mut |product, density| found.push((product, density * f64::from(order))),
            );
            found
        }

        fn grow(
            &self,
            left: u8,
            largest: u8,
            (product, density): (Vec<f64>, f64),
            found: &mut dyn FnMut(Vec<f64>, f64),
        ) {
            if left == 0 {
                found(product, density);
                return;
            }
            for size in 1..=left.min(largest) {
                for (branch, branch_density) in self.trees(size) {
                    let inner = self.apply(&branch);
                    let next = product.iter().zip(inner).map(|(a, b)| a * b).collect();
                    self.grow(left - size, size, (next, density * branch_density), found);
                }
            }
        }
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn assert_close(actual: f64, expected: f64) {
        assert!((actual - expected).abs() < 1e-13, "{actual} {expected}");
    }

    #[test]
    fn stages_are_consistent_and_of_order_two() {
        for tableau in [ESDIRK3, ESDIRK5] {
            let whole = Whole::new(&tableau);
            for (stage, row) in whole.rows.iter().enumerate() {
                let time = tableau.times[stage];
                assert_close(row.iter().sum(), time);
                if stage > 0 {
                    assert_close(dot(row, tableau.times), 0.5 * time * time);
                }
            }
        }
        assert_close(
            6.0 * GAMMA_3.powi(3) - 18.0 * GAMMA_3.powi(2) + 9.0 * GAMMA_3,
            1.0,
        );
    }

    /// Number of rooted trees of orders 1 to 6.
    #[test]
    fn all_trees_are_found() {
        let whole = Whole::new(&ESDIRK3);
        let counts: Vec<usize> = (1..=6).map(|order| whole.trees(order).len()).collect();
        // Branches of equal size are counted in each order, so two different trees of order 3 count twice in order 7.
        assert_eq!(counts, [1, 1, 2, 4, 9, 20]);
    }

    #[test]
    fn order_conditions_hold() {
        for (tableau, order, embedded_order) in [(ESDIRK3, 3, 4), (ESDIRK5, 5, 4)] {
            let whole = Whole::new(&tableau);
            let solution = whole.rows.last().expect("stages").clone();
            let embedded: Vec<f64> = solution
                .iter()
                .zip(tableau.error_weights)
                .map(|(weight, error)| weight - error)
                .collect();
            for (weights, highest) in [(solution, order), (embedded, embedded_order)] {
                for trees in (1..=highest).map(|order| whole.trees(order)) {
                    for (product, density) in trees {
                        assert_close(dot(&weights, &product), 1.0 / density);
                    }
                }
                // No condition of the next order is allowed to hold by chance for all trees.
                let next = whole.trees(highest + 1);
                assert!(next.iter().any(|(product, density)| {
                    (dot(&weights, product) - 1.0 / density).abs() > 1e-6
                }));
            }
        }
    }
}
