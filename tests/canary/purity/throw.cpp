void refused(int fault) { throw fault; }
