//! Finds cycles in a graph of names.

use std::collections::{BTreeMap, BTreeSet};

/// Arrows between nodes.
pub type Graph<T> = BTreeMap<T, BTreeSet<T>>;

/// Returns the groups of nodes in which each node leads to every other and back.
pub fn circles<T: Ord + Clone>(graph: &Graph<T>) -> BTreeSet<BTreeSet<T>> {
    let reached: BTreeMap<&T, BTreeSet<&T>> = graph
        .keys()
        .map(|node| (node, reached_from(graph, node)))
        .collect();
    let in_circle = reached
        .iter()
        .filter(|(node, reached)| reached.contains(*node));
    let group = |(node, own): (&&T, &BTreeSet<&T>)| -> BTreeSet<T> {
        let members = own
            .iter()
            .filter(|other| reached.get(*other).is_some_and(|back| back.contains(node)));
        members.map(|other| (*other).clone()).collect()
    };
    in_circle.map(group).collect()
}

fn reached_from<'a, T: Ord>(graph: &'a Graph<T>, start: &'a T) -> BTreeSet<&'a T> {
    let mut reached = BTreeSet::new();
    let mut open = vec![start];
    while let Some(node) = open.pop() {
        for next in graph.get(node).into_iter().flatten() {
            if reached.insert(next) {
                open.push(next);
            }
        }
    }
    reached
}

#[test]
fn circles_are_found_with_all_their_nodes() {
    let graph = |arrows: &[(u8, u8)]| {
        let mut graph = Graph::new();
        for &(from, to) in arrows {
            graph.entry(from).or_insert_with(BTreeSet::new).insert(to);
        }
        circles(&graph)
    };
    assert_eq!(graph(&[(1, 2), (2, 3), (1, 3)]), BTreeSet::new());
    let found = graph(&[(1, 2), (2, 3), (3, 1), (3, 4), (4, 5), (5, 4), (5, 6)]);
    assert_eq!(
        found,
        BTreeSet::from([BTreeSet::from([1, 2, 3]), BTreeSet::from([4, 5])])
    );
}
