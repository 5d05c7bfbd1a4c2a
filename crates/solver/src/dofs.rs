//! Which displacement components are unknown, and their numbers.

/// Marks a component that is held or prescribed.
pub const FIXED: u32 = u32::MAX;

/// Numbers of the unknown displacement components.
#[derive(Clone, Debug)]
pub struct Dofs {
    /// Number of (u_r, u_z) of each node, or [`FIXED`].
    pub number: Vec<[u32; 2]>,
    /// How many are unknown.
    pub count: usize,
}

impl Dofs {
    /// Numbers all components of `nodes` nodes but those that `held(node)` names.
    pub fn new(nodes: usize, held: impl Fn(usize) -> [bool; 2]) -> Dofs {
        let mut count = 0;
        let number = (0..nodes)
            .map(|node| {
                held(node).map(|fixed| {
                    if fixed {
                        FIXED
                    } else {
                        count += 1;
                        count - 1
                    }
                })
            })
            .collect();
        Dofs { number, count: count as usize }
    }

    /// The same components with number i replaced by `new_number[i]`.
    pub fn renumbered(&self, new_number: &[usize]) -> Dofs {
        let number = |&i: &u32| if i == FIXED { FIXED } else { new_number[i as usize] as u32 };
        Dofs {
            number: self.number.iter().map(|pair| pair.each_ref().map(number)).collect(),
            count: self.count,
        }
    }
}
