//! Progress of a command.

/// Progress of a command, for its observer, who ends the work by `false`.
#[derive(Debug)]
pub struct Progress<'a, N> {
    /// Share of the work that is done, 0 to 1.
    pub share: f64,
    /// Runs, closures or increments that are done, those of an earlier start too.
    pub done: usize,
    /// Number of all, as far as is known.
    pub all: usize,
    /// The part that has just ended or comes next; none at the beginning of many runs and while they go on.
    pub news: Option<&'a N>,
    /// A word for a person about work of an earlier start that is not taken up; once, at the beginning.
    pub notice: Option<&'a str>,
}

/// Hears of many runs from the threads that run them: at the beginning, as they go on and when they end;
/// `false` ends the work.
pub type Observer<'o, N> = dyn FnMut(&Progress<'_, N>) -> bool + Send + 'o;

impl<'a, N> Progress<'a, N> {
    /// `done` of `all` equal parts.
    pub(crate) fn counted(done: usize, all: usize, news: Option<&'a N>) -> Progress<'a, N> {
        Progress { share: done as f64 / all.max(1) as f64, done, all, news, notice: None }
    }

    /// The same with other `news`.
    pub(crate) fn telling<'b, M>(&self, news: Option<&'b M>) -> Progress<'b, M>
    where
        'a: 'b,
    {
        Progress { share: self.share, done: self.done, all: self.all, news, notice: self.notice }
    }
}
