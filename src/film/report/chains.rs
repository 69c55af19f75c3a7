//! Segments in which a surface passes through itself, put together to curves, whose points lie near each other.

use std::collections::HashMap;

/// Runs along segments between points of a grid: each chain goes on where another segment begins at its end. The order
/// depends on nothing but that of the segments.
pub(super) fn chains(segments: &[[[u16; 3]; 2]]) -> Vec<Vec<[u16; 3]>> {
    let mut at: HashMap<[u16; 3], Vec<usize>> = HashMap::new();
    for (k, ends) in segments.iter().enumerate().rev() {
        ends.iter().for_each(|end| at.entry(*end).or_default().push(k));
    }
    let mut is_taken = vec![false; segments.len()];
    let mut chains = Vec::new();
    for first in 0..segments.len() {
        if std::mem::replace(&mut is_taken[first], true) {
            continue;
        }
        let mut chain = segments[first].to_vec();
        while let Some(&end) = chain.last()
            && let Some(next) = at.get_mut(&end).and_then(|list| {
                while list.pop_if(|k| is_taken[*k]).is_some() {}
                list.pop()
            })
        {
            is_taken[next] = true;
            let [a, b] = segments[next];
            chain.push(if a == end { b } else { a });
        }
        chains.push(chain);
    }
    chains
}
