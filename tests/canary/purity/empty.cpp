// No symbol: an archive of this must not pass for pure.
