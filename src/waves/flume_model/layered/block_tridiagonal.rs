//! Block tridiagonal solver for symmetric positive definite systems, without pivoting (Golub & Van Loan, Matrix
//! computations, section 4.5).

/// A system of `blocks` x `blocks` blocks, each a `size` x `size` matrix: matrix, right-hand side and scratch memory.
///
/// Block row i is U_{i-1}^T q_{i-1} + D_i q_i + U_i q_{i+1} = r_i, with the vector q_i of unknowns.
#[derive(Debug, Clone)]
pub(super) struct BlockTridiagonal {
    size: usize,
    diagonal: Vec<f64>,
    upper: Vec<f64>,
    right: Vec<f64>,
    eliminated_upper: Vec<f64>,
    pivot: Vec<f64>,
}

impl BlockTridiagonal {
    /// Creates a system whose entries are all zero.
    pub(super) fn new(blocks: usize, size: usize) -> Self {
        let square = blocks * size * size;
        Self {
            size,
            diagonal: vec![0.0; square],
            upper: vec![0.0; square],
            right: vec![0.0; blocks * size],
            eliminated_upper: vec![0.0; square],
            pivot: vec![0.0; size * size],
        }
    }

    /// Sets all entries to zero.
    pub(super) fn clear(&mut self) {
        self.diagonal.fill(0.0);
        self.upper.fill(0.0);
        self.right.fill(0.0);
    }

    /// Adds `value` to `D_block[row, column]`.
    pub(super) fn add_diagonal(&mut self, block: usize, row: usize, column: usize, value: f64) {
        self.diagonal[(block * self.size + row) * self.size + column] += value;
    }

    /// Adds `value` to `U_block[row, column]`, which couples unknown `row` of the block to unknown `column` of the next
    /// block.
    pub(super) fn add_upper(&mut self, block: usize, row: usize, column: usize, value: f64) {
        self.upper[(block * self.size + row) * self.size + column] += value;
    }

    /// Adds `value` to `r_block[row]`.
    pub(super) fn add_right(&mut self, block: usize, row: usize, value: f64) {
        self.right[block * self.size + row] += value;
    }

    /// Returns the unknowns of all blocks; call it after [`Self::solve`].
    pub(super) fn unknowns(&self) -> &[f64] {
        &self.right
    }

    /// Solves the system; the unknowns overwrite the right-hand side.
    pub(super) fn solve(&mut self) {
        let blocks = self.right.len() / self.size;
        for block in 0..blocks {
            self.eliminate(block);
        }
        for block in (0..blocks.saturating_sub(1)).rev() {
            self.substitute_back(block);
        }
    }

    /// Eliminates q_{i-1} from block row i:
    /// S = D_i - U_{i-1}^T C_{i-1}, C_i = S^-1 U_i, r_i = S^-1 (r_i - U_{i-1}^T r_{i-1}).
    fn eliminate(&mut self, block: usize) {
        let k = self.size;
        let here = block * k * k;
        self.pivot.copy_from_slice(&self.diagonal[here..here + k * k]);
        if block > 0 {
            let before = here - k * k;
            for m in 0..k {
                for row in 0..k {
                    let u = self.upper[before + m * k + row];
                    if u == 0.0 {
                        continue;
                    }
                    for column in 0..k {
                        self.pivot[row * k + column] -= u * self.eliminated_upper[before + m * k + column];
                    }
                    self.right[block * k + row] -= u * self.right[(block - 1) * k + m];
                }
            }
        }
        let (upper, eliminated) = (&self.upper[here..here + k * k], &mut self.eliminated_upper[here..here + k * k]);
        eliminated.copy_from_slice(upper);
        solve_block(&mut self.pivot, eliminated, &mut self.right[block * k..(block + 1) * k]);
    }

    /// Computes the unknowns of a block from the unknowns of the next block: q_i = r_i - C_i q_{i+1}.
    fn substitute_back(&mut self, block: usize) {
        let k = self.size;
        for row in 0..k {
            let next = (0..k).map(|column| {
                self.eliminated_upper[(block * k + row) * k + column] * self.right[(block + 1) * k + column]
            });
            self.right[block * k + row] -= next.sum::<f64>();
        }
    }
}

/// Solves a block system in place for two right-hand sides, a block and a vector, by Gaussian elimination.
fn solve_block(matrix: &mut [f64], block: &mut [f64], vector: &mut [f64]) {
    let k = vector.len();
    for p in 0..k {
        let inverse = 1.0 / matrix[p * k + p];
        for row in p + 1..k {
            let factor = matrix[row * k + p] * inverse;
            if factor == 0.0 {
                continue;
            }
            for column in p + 1..k {
                matrix[row * k + column] -= factor * matrix[p * k + column];
            }
            for column in 0..k {
                block[row * k + column] -= factor * block[p * k + column];
            }
            vector[row] -= factor * vector[p];
        }
    }
    for p in (0..k).rev() {
        let inverse = 1.0 / matrix[p * k + p];
        for row in p + 1..k {
            let factor = matrix[p * k + row];
            for column in 0..k {
                block[p * k + column] -= factor * block[row * k + column];
            }
            vector[p] -= factor * vector[row];
        }
        for column in 0..k {
            block[p * k + column] *= inverse;
        }
        vector[p] *= inverse;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_satisfies_every_row() {
        let (blocks, k) = (5, 3);
        let mut system = BlockTridiagonal::new(blocks, k);
        let entry = |a: usize, b: usize| 0.3 * ((a * 7 + b * 3) as f64).sin();
        for block in 0..blocks {
            for row in 0..k {
                for column in 0..k {
                    let symmetric = entry(row, column) + entry(column, row);
                    system.add_diagonal(block, row, column, symmetric + if row == column { 4.0 } else { 0.0 });
                    if block + 1 < blocks {
                        system.add_upper(block, row, column, entry(row + block, column));
                    }
                }
                system.add_right(block, row, 1.0 + (block * k + row) as f64);
            }
        }
        let (diagonal, upper, right) = (system.diagonal.clone(), system.upper.clone(), system.right.clone());
        system.solve();
        let q = system.unknowns();
        for block in 0..blocks {
            for row in 0..k {
                let mut left = 0.0;
                for column in 0..k {
                    left += diagonal[(block * k + row) * k + column] * q[block * k + column];
                    if block + 1 < blocks {
                        left += upper[(block * k + row) * k + column] * q[(block + 1) * k + column];
                    }
                    if block > 0 {
                        left += upper[((block - 1) * k + column) * k + row] * q[(block - 1) * k + column];
                    }
                }
                // The 15 x 15 system is well conditioned, so only rounding errors remain.
                assert!((left - right[block * k + row]).abs() < 1e-12);
            }
        }
    }
}
