//! The order in which the nodes of a mesh are eliminated, for little fill.
//!
//! Nodes are ordered instead of unknowns: a node's two components have the same neighbours, and a quarter of
//! the graph is left. The approximate minimum degree of Amestoy, Davis and Duff (2004) is the best order of
//! small meshes but depends on the numbering it starts from: beyond some 40,000 unknowns one start takes up
//! to four times the operations of another. Two starts are tried therefore, and on large meshes nested
//! dissection (Karypis and Kumar 1998), which stays near unknowns^1.5 on all of them; the order with the
//! fewest operations is used.
//!
//! An order lists vertices, the first to be eliminated first; places are its inverse: `place[order[i]] = i`.

use crate::sparse::failure::FactorError;
use crate::sparse::minimum_degree::{elimination_tree, minimum_degree};
use feral_metis::{CscPattern, metis_order};

/// Free nodes from which nested dissection is tried: it takes ten times as long as a minimum degree, and on
/// smaller meshes was never the better.
const DISSECT_FROM: usize = 10_000;

/// The free nodes of a mesh and which of them share an element: a symmetric pattern without its diagonal.
struct Graph {
    starts: Vec<usize>,
    neighbours: Vec<usize>,
}

impl Graph {
    /// The graph of `size` vertices with these `edges`, each in both directions.
    fn new(size: usize, edges: impl Iterator<Item = [usize; 2]> + Clone) -> Graph {
        // end of each vertex's neighbours, and while they are put there, backwards, their start
        let mut ends = vec![0; size + 1];
        edges.clone().for_each(|[from, _]| ends[from] += 1);
        for vertex in 0..size {
            ends[vertex + 1] += ends[vertex];
        }
        let mut all = vec![0; ends[size]];
        let mut begins = ends.clone();
        for [from, to] in edges {
            begins[from] -= 1;
            all[begins[from]] = to;
        }
        let (mut starts, mut neighbours) = (vec![0], Vec::with_capacity(all.len()));
        for vertex in 0..size {
            let own = &mut all[begins[vertex]..ends[vertex]];
            own.sort_unstable();
            neighbours.extend(own.chunk_by(|a, b| a == b).map(|same| same[0]));
            starts.push(neighbours.len());
        }
        Graph { starts, neighbours }
    }

    /// Number of vertices.
    fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// The same graph with vertex i called `place[i]`.
    fn renumbered(&self, place: &[usize]) -> Graph {
        let edges = (0..self.size()).flat_map(|vertex| {
            let ends = &self.neighbours[self.starts[vertex]..self.starts[vertex + 1]];
            ends.iter().map(move |&end| [place[vertex], place[end]])
        });
        Graph::new(self.size(), edges)
    }

    /// For each vertex its place in an order of nested dissection, or nothing where that fails.
    fn dissection(&self) -> Option<Vec<usize>> {
        let narrow = |numbers: &[usize]| -> Option<Vec<i32>> {
            numbers.iter().map(|&n| i32::try_from(n).ok()).collect()
        };
        let (starts, neighbours) = (narrow(&self.starts)?, narrow(&self.neighbours)?);
        let order = metis_order(&CscPattern::new(self.size(), &starts, &neighbours)?).ok()?;
        let mut place = vec![0; self.size()];
        order.iter().enumerate().for_each(|(i, &vertex)| place[vertex as usize] = i);
        Some(place)
    }

    /// Operations of a factorisation in the order `place`, in a unit of its own: Σ c² over the c entries of
    /// each column.
    fn operations(&self, place: &[usize]) -> f64 {
        let renumbered = self.renumbered(place);
        let tree = elimination_tree(&renumbered.starts, &renumbered.neighbours);
        tree.count.iter().map(|&c| (c as f64).powi(2)).sum()
    }
}

/// The `free` nodes in the order in which to eliminate them; `cells` are elements of `nodes_per_cell` nodes.
///
/// # Errors
/// A graph with more edges than can be counted.
pub fn elimination_order(
    cells: &[u32],
    nodes_per_cell: usize,
    free: &[bool],
) -> Result<Vec<usize>, FactorError> {
    let nodes: Vec<usize> = (0..free.len()).filter(|&node| free[node]).collect();
    let mut vertex = vec![usize::MAX; free.len()];
    nodes.iter().enumerate().for_each(|(i, &node)| vertex[node] = i);
    let mut edges = Vec::with_capacity(cells.len() * nodes_per_cell);
    for cell in cells.chunks_exact(nodes_per_cell) {
        let ends: Vec<usize> =
            cell.iter().map(|&n| n as usize).filter(|&n| free[n]).map(|n| vertex[n]).collect();
        for &a in &ends {
            edges.extend(ends.iter().filter(|&&b| b != a).map(|&b| [a, b]));
        }
    }
    let graph = Graph::new(nodes.len(), edges.into_iter());
    let places = cheapest_places(&graph)?;
    let mut order = vec![0; nodes.len()];
    places.iter().zip(nodes).for_each(|(&place, node)| order[place] = node);
    Ok(order)
}

/// The places of the vertices in the cheapest of the orders that are tried.
fn cheapest_places(graph: &Graph) -> Result<Vec<usize>, FactorError> {
    let forwards = minimum_degree(&graph.starts, &graph.neighbours)?;
    let mut best = (graph.operations(&forwards), forwards);
    let mut weigh = |places: Vec<usize>| {
        let operations = graph.operations(&places);
        if operations < best.0 {
            best = (operations, places);
        }
    };
    // the same from the last vertex on: vertex i is called last - i there
    let reverse: Vec<usize> = (0..graph.size()).rev().collect();
    let turned = graph.renumbered(&reverse);
    let backwards = minimum_degree(&turned.starts, &turned.neighbours)?;
    weigh(reverse.iter().map(|&i| backwards[i]).collect());
    if graph.size() >= DISSECT_FROM {
        // beyond the numbers of the dissection there is still a minimum degree
        graph.dissection().into_iter().for_each(weigh);
    }
    Ok(best.1)
}
