//! Claims about MSH files.

use super::*;
use crate::ElementKind;

/// Two 8-node cells side by side, 0.3 wide and 0.1 high, with numbers that have no short decimal form.
fn strip() -> Mesh {
    let (w, h) = (0.3 / 7.0, 0.1);
    let nodes = vec![
        [0.0, -h],
        [w, -h],
        [2.0 * w, -h],
        [0.0, 0.0],
        [w, 0.0],
        [2.0 * w, 0.0],
        [0.5 * w, -h],
        [1.5 * w, -h],
        [0.0, -0.5 * h],
        [w, -0.5 * h],
        [2.0 * w, -0.5 * h],
        [0.5 * w, 1.0 / 3.0 * h],
        [1.5 * w, 0.0],
    ];
    let cells = vec![0, 1, 4, 3, 6, 9, 11, 8, 1, 2, 5, 4, 7, 10, 12, 9];
    let edge = |cell, side| Edge { cell, side };
    let sides = Sides {
        axis: vec![edge(0, 3)],
        base: vec![edge(0, 0), edge(1, 0)],
        surface: vec![edge(0, 2), edge(1, 2)],
        outer: vec![edge(1, 1)],
    };
    Mesh { kind: ElementKind::Quad8, nodes, cells, sides }
}

fn written(mesh: &Mesh) -> String {
    let mut text = Vec::new();
    write_msh(&mut text, mesh).unwrap();
    String::from_utf8(text).unwrap()
}

#[test]
fn a_mesh_reads_back_to_the_same_bits_and_writes_the_same_text() {
    let mesh = strip();
    let text = written(&mesh);
    let back = read_msh(text.as_bytes()).unwrap();
    assert_eq!(back, mesh);
    assert_eq!(written(&back), text);
}

/// A square of four nodes as Gmsh's graphical interface may leave it: clockwise, sparse tags, points, the
/// plane y = 0, comments, a node of no cell, a curve without a name.
const FOREIGN: &str = r#"$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
4
1 5 "Axis"
1 7 "base"
1 9 "surface"
2 1 "metal"
$EndPhysicalNames

$Entities
1 4 1 0
1 0 0 0 0
11 0 0 -1 0 0 0 1 5 2 1 -2
12 0 0 -1 1 0 -1 1 -7 2 2 -3
13 1 0 -1 1 0 0 0 2 3 -4
14 0 0 0 1 0 0 2 9 7777 2 4 -1
1 0 0 -1 1 0 0 1 1 4 11 12 13 14
$EndEntities
$Nodes
2 5 10 50
0 1 0 1
10
0 0 0
2 1 0 4
20
30
40
50
0 0 -1
1 0 -1
1 0 0
0.5 0 -0.5
$EndNodes
$Elements
5 5 1 9
0 1 15 1
1 10
1 11 1 1
2 10 20
1 12 1 1
3 30 20
1 14 1 1
4 10 40
2 1 3 1
9 10 40 30 20
$EndElements
"#;

#[test]
fn a_clockwise_mesh_in_the_plane_y_0_is_turned_and_cleaned() {
    let mesh = read_msh(FOREIGN.as_bytes()).unwrap();
    assert_eq!(mesh.nodes, [[0.0, 0.0], [0.0, -1.0], [1.0, -1.0], [1.0, 0.0]]);
    assert_eq!(mesh.cells, [0, 1, 2, 3]);
    let nodes = |edges: &[Edge]| edges.iter().map(|&e| mesh.edge_nodes(e).0).collect::<Vec<_>>();
    assert_eq!(nodes(&mesh.sides.axis), [[0, 1]]);
    assert_eq!(nodes(&mesh.sides.base), [[1, 2]]);
    assert_eq!(nodes(&mesh.sides.surface), [[3, 0]]);
    assert!(mesh.sides.outer.is_empty());
}

#[test]
fn the_surface_comes_in_order_from_the_axis_outward() {
    let mut mesh = strip();
    mesh.sides.surface.reverse();
    assert_eq!(read_msh(written(&mesh).as_bytes()).unwrap().sides, strip().sides);
}

/// Changes that a person may make to a file, and what the error must name.
#[test]
fn broken_files_are_refused_with_the_line() {
    let good = FOREIGN;
    let table: &[(&str, &str, usize, &str)] = &[
        ("4.1 0 8", "2.2 0 8", 2, "version 2.2, expected 4.1"),
        ("4.1 0 8", "4.1 1 8", 2, "binary"),
        ("4.1 0 8", "4.1", 2, "4.1 0 8"),
        ("$MeshFormat\n", "$Nodes\n", 1, "$MeshFormat"),
        ("$MeshFormat\n", "hello\n", 1, "not an MSH file"),
        ("1 0 -1\n1 0 0\n", "1 0 -1\n1 0 x\n", 33, "found \"x\""),
        ("1 0 -1\n1 0 0\n", "1 0 -1\n1 0 nan\n", 33, "found nan"),
        ("1 0 -1\n1 0 0\n", "1 0 -1\n1 0\n", 33, "coordinates"),
        ("2 1 0 4\n20\n30", "2 1 0 4\n20\n20", 28, "given twice"),
        ("2 5 10 50", "2 6 10 50", 22, "promises 6 nodes"),
        ("2 1 0 4\n", "2 1 0 18446744073709551615\n", 31, "tag of a node"),
        ("9 10 40 30 20", "9 10 40 30 99", 47, "no node 99"),
        ("9 10 40 30 20", "9 10 40 30", 47, "4 nodes"),
        ("9 10 40 30 20", "9 10 40 30 20 50", 47, "found 5"),
        ("9 10 40 30 20", "9 10 30 40 20", 47, "folded"),
        ("2 1 3 1\n9 10 40 30 20", "2 1 2 1\n9 10 40 30", 46, "recombine"),
        ("2 1 3 1\n9 10 40 30 20", "2 1 10 1\n9 1 2 3 4 5 6 7 8 9", 46, "SecondOrderIncomplete"),
        ("2 1 3 1\n9 10 40 30 20", "2 1 77 1\n9 10 40 30", 46, "type 77"),
        ("2 1 3 1\n", "2 1 3 2\n", 48, "found $EndElements"),
        ("4 10 40", "4 10 30", 45, "not on the boundary"),
        ("$EndElements", "", 47, "missing"),
        ("1 9 \"surface\"", "1 9 \"top\"", 0, "no physical curve named \"surface\" (found: Axis, base, top)"),
        ("0 0 -1\n1 0 -1\n", "0 0.5 -1\n1 0 -1\n", 0, "not plane"),
    ];
    for (old, new, line, message) in table {
        assert!(good.contains(old), "{old:?} is not in the file");
        let error = read_msh(good.replacen(old, new, 1).as_bytes()).expect_err(new);
        assert!(error.message.contains(message), "{new:?}: {error}");
        assert_eq!(error.line, *line, "{new:?}: {error}");
    }
    assert!(read_msh(b"").unwrap_err().message.contains("no quadrangles"));
    assert_eq!(read_msh(b"$MeshFormat\n\xff\xfe").unwrap_err().line, 2);
}

#[test]
fn two_bodies_and_a_closed_surface_are_refused() {
    let mut apart = strip();
    apart.nodes.extend_from_within(..);
    let n = 13;
    apart.cells.extend(strip().cells.iter().map(|c| c + n));
    assert!(read_msh(written(&apart).as_bytes()).unwrap_err().message.contains("2 pieces"));
    let mut ring = strip();
    let all = [(0, 0), (1, 0), (1, 1), (1, 2), (0, 2), (0, 3)].map(|(cell, side)| Edge { cell, side });
    ring.sides.surface = all.to_vec();
    assert!(read_msh(written(&ring).as_bytes()).unwrap_err().message.contains("closed"));
}

/// Every file that one cut leaves is an error or a mesh, never a panic.
#[test]
fn a_file_cut_anywhere_does_not_panic() {
    for end in 0..FOREIGN.len() {
        assert!(read_msh(&FOREIGN.as_bytes()[..end]).is_err() || end + 1 >= FOREIGN.len(), "{end}");
    }
}

/// Every file with some words replaced by others of the file, or by extremes, is an error or a mesh that
/// holds together, never a panic.
#[test]
fn a_scrambled_file_does_not_panic() {
    let odd = ["-1", "0", "99999999999999999999", "1e400", "nan", "\"", "$Nodes", "$EndNodes", "\n", ""];
    let words: Vec<&str> = FOREIGN.split_inclusive(char::is_whitespace).collect();
    let mut state = 1_u64;
    let mut next = move |n: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % n
    };
    let mut meshes = 0;
    for _ in 0..20_000 {
        let mut scrambled: Vec<String> = words.iter().map(|w| w.to_string()).collect();
        for _ in 0..1 + next(3) {
            let at = next(words.len());
            let space: String = words[at].chars().filter(|c| c.is_whitespace()).collect();
            let new = if next(2) == 0 { odd[next(odd.len())] } else { words[next(words.len())].trim() };
            scrambled[at] = format!("{new}{space}");
        }
        if let Ok(mesh) = read_msh(scrambled.concat().as_bytes()) {
            meshes += 1;
            assert!(mesh.cells.iter().all(|&n| (n as usize) < mesh.nodes.len()));
            assert!(mesh.quality().is_some_and(|q| q.min_scaled_jacobian > 0.0));
        }
    }
    assert!(meshes > 100, "{meshes}");
}
