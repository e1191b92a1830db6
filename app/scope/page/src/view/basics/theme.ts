// SPDX-License-Identifier: Apache-2.0
/// Light or dark: as the system has it until the switch is used, which is remembered where the
/// browser lets a page remember.

export type Theme = 'light' | 'dark';

const KEY = 'graben-scope-theme';

export interface ThemeSwitch {
  readonly dark: boolean;
  toggle(): void;
  /// The colour of a custom property (without its dashes) in the present theme.
  colour(name: string): string;
  on_change(listener: () => void): void;
}

function remembered(): Theme | null {
  try {
    const theme = localStorage.getItem(KEY);
    return theme === 'light' || theme === 'dark' ? theme : null;
  } catch {
    return null;  // A page opened from a file may be refused storage.
  }
}

function remember(theme: Theme): void {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // Lasts until the page is closed, then.
  }
}

export function create_theme(): ThemeSwitch {
  const system = matchMedia('(prefers-color-scheme: dark)');
  const listeners: (() => void)[] = [];
  const colours = new Map<string, string>();
  let chosen = remembered();

  const apply = () => {
    document.documentElement.dataset.theme = self.dark ? 'dark' : 'light';
    colours.clear();
    for (const listener of listeners) {
      listener();
    }
  };
  const self: ThemeSwitch = {
    get dark() {
      return chosen === null ? system.matches : chosen === 'dark';
    },
    toggle() {
      chosen = self.dark ? 'light' : 'dark';
      remember(chosen);
      apply();
    },
    colour(name) {
      let colour = colours.get(name);
      if (colour === undefined) {
        colour = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
        colours.set(name, colour);
      }
      return colour;
    },
    on_change(listener) {
      listeners.push(listener);
    },
  };
  system.addEventListener('change', apply);
  // Paper is light, whatever the screen is.
  addEventListener('beforeprint', () => {
    const before = chosen;
    chosen = 'light';
    apply();
    addEventListener('afterprint', () => {
      chosen = before;
      apply();
    }, {once: true});
  });
  apply();
  return self;
}
