//! Claim: the same scene gives the same bits whatever else runs: alone, and on two threads at once.
//!
//! Source: a case is solved by one thread with sums in a fixed order. Tolerance: none.

use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

#[test]
fn a_scene_gives_the_same_bits_alone_and_beside_others() {
    let scene = scene(Accuracy::Draft).unwrap();
    let alone = crush(&scene).unwrap();
    let beside: Vec<_> = std::thread::scope(|scope| {
        let runs: Vec<_> = (0..3).map(|_| scope.spawn(|| crush(&scene).unwrap())).collect();
        runs.into_iter().map(|run| run.join().unwrap()).collect()
    });
    for other in beside {
        assert_eq!(alone.rows, other.rows);
        assert_eq!(alone.summary.unloading_stiffness, other.summary.unloading_stiffness);
    }
}
