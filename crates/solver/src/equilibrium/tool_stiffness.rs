//! Answer of the force of the tool to its travel, from one solve.

use crate::body::dofs::Dofs;
use crate::contact::edge::{ContactEdge, EdgeContact};

/// Growth of the force with the advance of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolStiffness {
    /// dF per travel of the tool, the compliance of the penalty included.
    pub travel: f64,
    /// dF/dh: the compliance of the penalty taken out.
    pub depth: f64,
}

/// The stiffness of the tool on the `edges` in contact; `solve` replaces a right-hand side by K⁻¹ times it.
///
/// With v = ∂F/∂u and c = ∂F/∂travel at fixed u: K_t = c - v K⁻¹ v, of which ∫ε δd² dA is spent in the
/// penalty.
pub fn tool_stiffness<'a>(
    dofs: &Dofs,
    edges: impl Iterator<Item = (&'a ContactEdge, &'a EdgeContact)> + Clone,
    solve: impl FnOnce(&mut [f64]),
) -> ToolStiffness {
    let mut v = vec![0.0; dofs.count];
    let mut c = 0.0;
    for (edge, contact) in edges.clone() {
        for a in 0..edge.node_count() {
            for i in 0..2 {
                // a translation of the tool along z is minus that of all nodes of the edge
                let row: f64 = (0..edge.node_count()).map(|b| contact.stiffness[a][i][b][1]).sum();
                if i == 1 {
                    c += row;
                }
                if let Some(slot) = v.get_mut(dofs.number[edge.nodes[a] as usize][i] as usize) {
                    *slot += row;
                }
            }
        }
    }
    let mut u = v.clone();
    solve(&mut u);
    // the tool goes down by 1, the body follows by u (down): δd = 1 - u on the contact
    let travel = c - v.iter().zip(&u).map(|(a, b)| a * b).sum::<f64>();
    let mut spent = 0.0;
    for (edge, contact) in edges {
        let d: [[f64; 2]; 3] = edge.nodes.map(|node| {
            let numbers = dofs.number[node as usize];
            let at = |i: usize| u.get(numbers[i] as usize).copied().unwrap_or(0.0);
            [-at(0), 1.0 - at(1)]
        });
        for a in 0..edge.node_count() {
            for i in 0..2 {
                for b in 0..edge.node_count() {
                    for j in 0..2 {
                        spent += d[a][i] * contact.stiffness[a][i][b][j] * d[b][j];
                    }
                }
            }
        }
    }
    ToolStiffness { travel, depth: travel * travel / (travel - spent) }
}
