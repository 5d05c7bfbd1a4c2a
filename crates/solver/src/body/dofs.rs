//! Unknown displacement components and their numbers.

/// Marks a component that is fixed or prescribed.
pub const FIXED: u32 = u32::MAX;

/// Numbers of the unknown displacement components.
#[derive(Clone, Debug)]
pub struct Dofs {
    /// Number of (u_r, u_z) of each node, or [`FIXED`].
    pub number: Vec<[u32; 2]>,
    /// Number of unknowns.
    pub count: usize,
}

impl Dofs {
    /// Numbers the components of `nodes` nodes, node after node as they stand in `order`, without those that
    /// `fixed(node)` names. `order` has each node at most once; nodes that are not in it are fixed.
    pub fn new(nodes: usize, order: &[usize], fixed: impl Fn(usize) -> [bool; 2]) -> Dofs {
        let mut count = 0;
        let mut number = vec![[FIXED; 2]; nodes];
        for &node in order {
            for (number, fixed) in number[node].iter_mut().zip(fixed(node)) {
                if !fixed {
                    *number = count;
                    count += 1;
                }
            }
        }
        Dofs { number, count: count as usize }
    }
}
