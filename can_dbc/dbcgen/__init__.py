"""Reads a DBC, refuses what it does not understand, writes C++ codecs."""
