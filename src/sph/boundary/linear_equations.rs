//! Solves four linear equations, for interpolations that are exact for linear fields: at ghost nodes and at gauges.

/// Solves A x = b by Gaussian elimination with pivoting. Each entry of `rows` is a row of A, followed by its right-hand
/// side b. Returns `None` if |det A| is below `least`.
pub fn solve(mut rows: [[f64; 5]; 4], least: f64) -> Option<[f64; 4]> {
    let mut determinant = 1.0;
    for column in 0..4 {
        let pivot = (column..4).max_by(|&i, &j| rows[i][column].abs().total_cmp(&rows[j][column].abs()))?;
        rows.swap(column, pivot);
        let lead = rows[column];
        determinant *= lead[column];
        if lead[column] == 0.0 {
            return None;
        }
        for row in &mut rows[column + 1..] {
            let factor = row[column] / lead[column];
            for k in column..5 {
                row[k] -= factor * lead[k];
            }
        }
    }
    if determinant.abs() < least {
        return None;
    }
    let mut solution = [0.0; 4];
    for k in (0..4).rev() {
        let known: f64 = (k + 1..4).map(|j| rows[k][j] * solution[j]).sum();
        solution[k] = (rows[k][4] - known) / rows[k][k];
    }
    Some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_satisfies_the_equations_and_singular_systems_return_none() {
        let rows = [
            [2.0, 1.0, 0.0, 0.5, 1.0],
            [0.0, 3.0, 1.0, 0.0, 2.0],
            [1.0, 0.0, 4.0, 1.0, 3.0],
            [0.0, 1.0, 0.0, 5.0, 4.0],
        ];
        let x = solve(rows, 1e-9).unwrap();
        for row in rows {
            let left: f64 = (0..4).map(|k| row[k] * x[k]).sum();
            // Limit 1e-12: rounding.
            assert!((left - row[4]).abs() < 1e-12);
        }
        assert!(solve([[1.0, 1.0, 0.0, 0.0, 1.0]; 4], 1e-9).is_none());
    }
}
