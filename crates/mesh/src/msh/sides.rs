//! From the content of an MSH file to a mesh: one plane, one orientation, sides by name and in order.

use super::error::MshError;
use super::file::{Curve, Element, File};
use crate::{Edge, Mesh, Sides};
use std::collections::HashMap;

/// Makes the mesh.
pub(super) fn mesh(file: File) -> Result<Mesh, MshError> {
    let plane = section(&file)?;
    let mut cells = Vec::with_capacity(file.quads.len() * file.kind.nodes());
    for quad in &file.quads {
        cells.extend(oriented(quad, &plane)?);
    }
    let mut index: Vec<Option<u32>> = vec![None; file.nodes.len()];
    cells.iter().for_each(|&node| index[node] = Some(0));
    // the nodes that cells use, in the order of the file
    let mut nodes = Vec::new();
    for (slot, point) in index.iter_mut().zip(&plane) {
        if slot.is_some() {
            *slot =
                Some(u32::try_from(nodes.len()).map_err(|_| MshError::whole("holds more nodes than 2^32"))?);
            nodes.push(*point);
        }
    }
    let cells = cells.into_iter().filter_map(|n| index[n]).collect();
    let mut mesh = Mesh { kind: file.kind, nodes, cells, sides: Sides::default() };
    one_piece(&mesh)?;
    let boundary = boundary(&mesh, &file.quads)?;
    for curve in &file.curves {
        let edges = curve_edges(curve, &index, &boundary)?;
        if let Some(side) = mesh.sides.by_name(&curve.name.to_lowercase()) {
            *side = edges;
        }
    }
    for (name, edges) in mesh.sides.named() {
        // a body in plane strain, or a ring, has no axis; the outer side may be left free
        if edges.is_empty() && (name == "base" || name == "surface") {
            let found: Vec<_> = file.curves.iter().map(|c| c.name.as_str()).collect();
            let found = if found.is_empty() { "none".into() } else { found.join(", ") };
            return Err(MshError::whole(format!(
                "has no physical curve named \"{name}\" (found: {found}): name the sides axis, base, surface, outer"
            )));
        }
    }
    mesh.sides.surface = outward(&mesh, &mesh.sides.surface)?;
    Ok(mesh)
}

/// The coordinates (r, height) of the nodes: the section lies in z = 0 or in y = 0.
fn section(file: &File) -> Result<Vec<[f64; 2]>, MshError> {
    let used = || file.quads.iter().flat_map(|q| q.nodes.iter().map(|&n| file.nodes[n]));
    let pick = if used().all(|p| p[2] == 0.0) {
        1
    } else if used().all(|p| p[1] == 0.0) {
        2
    } else {
        return Err(MshError::whole("is not plane: expected all nodes at z = 0, or all at y = 0"));
    };
    Ok(file.nodes.iter().map(|p| [p[0], p[pick]]).collect())
}

/// The nodes of a quadrilateral, corners counterclockwise.
fn oriented(quad: &Element, plane: &[[f64; 2]]) -> Result<Vec<usize>, MshError> {
    let cross = |k: usize| {
        let p = |i: usize| plane[quad.nodes[i % 4]];
        let (o, a, b) = (p(k), p(k + 1), p(k + 3));
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let corners = [0, 1, 2, 3].map(cross);
    let n = &quad.nodes;
    if corners.iter().all(|&c| c > 0.0) {
        return Ok(n.clone());
    }
    if corners.iter().all(|&c| c < 0.0) {
        let corners = [n[0], n[3], n[2], n[1]];
        let middles = if n.len() == 8 { vec![n[7], n[6], n[5], n[4]] } else { Vec::new() };
        return Ok([&corners[..], &middles[..]].concat());
    }
    Err(MshError::new(quad.line, "this quadrangle is folded or flat: expected four convex corners"))
}

/// All cells must hang together.
fn one_piece(mesh: &Mesh) -> Result<(), MshError> {
    let mut parent: Vec<u32> = (0..mesh.nodes.len() as u32).collect();
    fn root(parent: &mut [u32], mut n: u32) -> u32 {
        while parent[n as usize] != n {
            parent[n as usize] = parent[parent[n as usize] as usize];
            n = parent[n as usize];
        }
        n
    }
    for cell in mesh.cells.chunks_exact(mesh.kind.nodes()) {
        for &node in &cell[1..] {
            let (a, b) = (root(&mut parent, cell[0]), root(&mut parent, node));
            parent[a as usize] = b;
        }
    }
    let pieces = (0..mesh.nodes.len() as u32).filter(|&n| root(&mut parent, n) == n).count();
    if pieces > 1 {
        return Err(MshError::whole(format!(
            "falls into {pieces} pieces that share no node: expected one body (Coherence Mesh joins double nodes)"
        )));
    }
    Ok(())
}

/// The sides of cells that no other cell shares, by their two corners in ascending order.
fn boundary(mesh: &Mesh, quads: &[Element]) -> Result<HashMap<[u32; 2], Edge>, MshError> {
    let mut seen: HashMap<[u32; 2], (usize, Edge)> = HashMap::new();
    for (cell, quad) in quads.iter().enumerate() {
        for side in 0..4 {
            let edge = Edge { cell: cell as u32, side };
            let ([a, b], _) = mesh.edge_nodes(edge);
            let count = &mut seen.entry([a.min(b), a.max(b)]).or_insert((0, edge)).0;
            *count += 1;
            if *count > 2 {
                let message = "a side of this quadrangle belongs to three cells, expected at most two";
                return Err(MshError::new(quad.line, message));
            }
        }
    }
    Ok(seen.into_iter().filter(|(_, (count, _))| *count == 1).map(|(key, (_, edge))| (key, edge)).collect())
}

/// The cell sides that the lines of a physical curve lie on, in the order of the file.
fn curve_edges(
    curve: &Curve,
    index: &[Option<u32>],
    boundary: &HashMap<[u32; 2], Edge>,
) -> Result<Vec<Edge>, MshError> {
    let edge = |piece: &Element| {
        let ends = index[piece.nodes[0]].zip(index[piece.nodes[1]]);
        let edge = ends.and_then(|(a, b)| boundary.get(&[a.min(b), a.max(b)])).copied();
        let message = || format!("this piece of {:?} is not on the boundary of the cells", curve.name);
        edge.ok_or_else(|| MshError::new(piece.line, message()))
    };
    let edges = curve.lines.iter().map(edge).collect::<Result<Vec<Edge>, _>>()?;
    let mut sorted = edges.clone();
    sorted.sort();
    if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
        return Err(MshError::new(curve.lines[0].line, format!("{:?} holds a piece twice", curve.name)));
    }
    Ok(edges)
}

/// The edges of the surface in order from the axis outward; pieces that do not touch, by their innermost
/// point.
///
/// Counterclockwise around the body the surface runs inward, so each edge is followed by the one that ends
/// where it starts.
fn outward(mesh: &Mesh, surface: &[Edge]) -> Result<Vec<Edge>, MshError> {
    let ends = |edge: Edge| mesh.edge_nodes(edge).0;
    let by_end: HashMap<u32, Edge> = surface.iter().map(|&e| (ends(e)[1], e)).collect();
    let starts: std::collections::HashSet<u32> = surface.iter().map(|&e| ends(e)[0]).collect();
    if by_end.len() < surface.len() || starts.len() < surface.len() {
        return Err(MshError::whole("the surface branches: expected a line without forks"));
    }
    let mut heads: Vec<Edge> = surface.iter().copied().filter(|&e| !starts.contains(&ends(e)[1])).collect();
    let radius = |edge: &Edge| mesh.nodes[ends(*edge)[1] as usize][0];
    heads.sort_by(|a, b| radius(a).total_cmp(&radius(b)));
    let mut ordered = Vec::with_capacity(surface.len());
    for head in heads {
        let mut next = Some(head);
        while let Some(edge) = next {
            ordered.push(edge);
            next = by_end.get(&ends(edge)[0]).copied();
        }
    }
    if ordered.len() < surface.len() {
        return Err(MshError::whole("the surface is closed in itself: expected a line with two ends"));
    }
    Ok(ordered)
}
