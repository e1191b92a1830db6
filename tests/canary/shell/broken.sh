#!/bin/sh
if true; then
  echo 'no end'
