//! Sets that become one, two at a time (union-find).

/// Numbers from 0, each in its own set at first.
pub(super) struct Forest(Vec<u32>);

impl Forest {
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The root of a number's set; shortens the path to it.
    pub fn find(&mut self, mut one: u32) -> u32 {
        let Self(root) = self;
        while root[one as usize] != one {
            root[one as usize] = root[root[one as usize] as usize];
            one = root[one as usize];
        }
        one
    }

    /// Joins the sets of two numbers; the smaller root becomes the root of both. True if they were two sets.
    pub fn join(&mut self, pair: [u32; 2]) -> bool {
        let [a, b] = pair.map(|one| self.find(one));
        self.hang(a.max(b), a.min(b));
        a != b
    }

    /// Joins the sets of two roots; the second one stays a root.
    pub fn hang(&mut self, gone: u32, kept: u32) {
        self.0[gone as usize] = kept;
    }

    /// The roots of all sets, in ascending order.
    pub fn roots(&self) -> Vec<u32> {
        (0..self.0.len() as u32).filter(|&one| self.0[one as usize] == one).collect()
    }
}
