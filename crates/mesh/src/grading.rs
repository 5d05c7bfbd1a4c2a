//! Positions of nodes along a line, from a wanted element size that varies along it.

/// Divides [from, to] so that elements have about the size `size(x)`; every `kink` strictly inside becomes a node.
///
/// Between two kinks the number of elements is ∫dx/size, rounded to at least one, and the nodes lie at equal shares of
/// that integral. Kinks closer than a third of an element to each other or to an end are left out.
pub fn divide(from: f64, to: f64, kinks: &[f64], size: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut stops = vec![from];
    for &kink in kinks {
        let gap = size(kink) / 3.0;
        if kink - stops[stops.len() - 1] > gap && to - kink > gap {
            stops.push(kink);
        }
    }
    stops.push(to);
    let mut nodes = vec![from];
    for pair in stops.windows(2) {
        divide_piece(pair[0], pair[1], &size, &mut nodes);
    }
    nodes
}

/// Appends the division of one piece, without its first node.
fn divide_piece(from: f64, to: f64, size: &impl Fn(f64) -> f64, nodes: &mut Vec<f64>) {
    const SAMPLES: usize = 400;
    // the integral of 1/size by the midpoint rule
    let x = |i: usize| from + (to - from) * i as f64 / SAMPLES as f64;
    let mut integral = vec![0.0; SAMPLES + 1];
    for i in 0..SAMPLES {
        let middle = 0.5 * (x(i) + x(i + 1));
        integral[i + 1] = integral[i] + (x(i + 1) - x(i)) / size(middle);
    }
    let total = integral[SAMPLES];
    let count = (total.round() as usize).max(1);
    let mut i = 0;
    for k in 1..count {
        let target = total * k as f64 / count as f64;
        while integral[i + 1] < target {
            i += 1;
        }
        let share = (target - integral[i]) / (integral[i + 1] - integral[i]);
        nodes.push(x(i) + share * (x(i + 1) - x(i)));
    }
    nodes.push(to);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinks_are_nodes_and_sizes_follow_the_wish() {
        let nodes = divide(0.0, 10.0, &[3.3, 3.4, 9.9], |x| 0.2 + 0.2 * x);
        assert!(nodes.contains(&3.3) && !nodes.contains(&3.4) && !nodes.contains(&9.9));
        for pair in nodes.windows(2) {
            let (size, wish) = (pair[1] - pair[0], 0.2 + 0.1 * (pair[0] + pair[1]));
            assert!((size / wish - 1.0).abs() < 0.4, "{size} {wish}");
        }
    }
}
