# SPDX-License-Identifier: Apache-2.0
"""Reads a DBC, refuses what it does not understand, writes C++ codecs."""
