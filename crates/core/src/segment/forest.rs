//! Sets that become one, two at a time (union-find).

/// Numbers from 0, each of them in a set of its own at first.
pub(super) struct Forest(Vec<u32>);

impl Forest {
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The number that stands for the set of another, with the way to it shortened.
    pub fn find(&mut self, mut one: u32) -> u32 {
        let Self(root) = self;
        while root[one as usize] != one {
            root[one as usize] = root[root[one as usize] as usize];
            one = root[one as usize];
        }
        one
    }

    /// Makes one set of those of two numbers, for which the smaller of what stands for these stands; whether they were two.
    pub fn join(&mut self, pair: [u32; 2]) -> bool {
        let [a, b] = pair.map(|one| self.find(one));
        self.hang(a.max(b), a.min(b));
        a != b
    }

    /// Makes one set of those that two numbers stand for; the second stands for it.
    pub fn hang(&mut self, gone: u32, kept: u32) {
        self.0[gone as usize] = kept;
    }

    /// The numbers that stand for sets, in ascending order.
    pub fn roots(&self) -> Vec<u32> {
        (0..self.0.len() as u32).filter(|&one| self.0[one as usize] == one).collect()
    }
}
