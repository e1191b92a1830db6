// SPDX-License-Identifier: Apache-2.0
/// Generated from firmware/safety/limits.toml by can_dbc/generate_all.py.

/// What holds lambda, by EcuStatus.LimitKind, and whose number LimitIndex is.
export const LIMITS: readonly {readonly text: string; readonly of: string}[] = [
  {text: 'none', of: ''},
  {text: 'pump flow', of: 'pump'},
  {text: 'back flow', of: 'drive'},
  {text: 'spool travel', of: 'drive'},
  {text: 'stroke end', of: 'drive'},
  {text: 'rise of lambda', of: ''},
  {text: 'slowed', of: 'fault'},
  {text: 'implement flow', of: ''},
  {text: 'transmission flow', of: 'track'},
  {text: 'what lies ahead', of: ''},
  {text: 'off the grade', of: ''},
  {text: 'swing end', of: ''},
  {text: 'fence', of: 'fence'},
  {text: 'behind the plan', of: ''},
];
