// Light and dark: as the system wants it, until somebody chooses.

import { element } from './text.js';

export function isDark() {
  const { print, theme } = document.documentElement.dataset;
  if (print !== undefined) return false;
  return theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

/** Colours of what is drawn on canvases, by the style sheet. */
export function colours() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    ink: of('ink-soft'), line: of('line'), now: of('accent'), main: of('solid-main'), body: of('solid-body'), edge: of('solid-edge'),
    joint: of('joint'), centre: of('centre'), momentum: of('momentum'), cone: of('momentum'), trail: of('trail'),
    axes: [of('axis-x'), of('axis-y'), of('axis-z')],
  };
}

/** Light instead of dark, or the reverse; `redraw` is for what is on canvases. */
export function switchTheme(redraw) {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  redraw?.();
  return true;
}

export function themeButton(redraw) {
  return element('button', { type: 'button', title: 'Light or dark (t)', click: () => switchTheme(redraw) }, 'Light / dark');
}
