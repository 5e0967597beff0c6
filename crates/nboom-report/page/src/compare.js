// Several runs on the same axes: one curve for each run.

import { figuresOf } from './curves.js';
import { Figure } from './plot.js';
import { element } from './text.js';
import { colours, isDark } from './theme.js';

/** Marks of several runs would hide each other. */
const UNMARKED = 'Peaks by latches are not drawn here: the verdicts have the largest.';

/** Figures that several runs have; of each, one quantity is chosen. */
export function comparedFigures(runs, place, shown, go) {
  const all = runs.map(figuresOf);
  const titles = [...new Set(all.flat().map(({ title }) => title))];
  shown.figures = [];
  titles.forEach((title) => {
    const found = all.map((figures) => figures.find((figure) => figure.title === title));
    const curves = (figure) => figure?.series.filter(({ points }) => !points) ?? [];
    const labels = [...new Set(found.flatMap((figure) => curves(figure).map(({ label }) => label)))];
    const holder = element('div', {});
    const number = shown.figures.length;
    const choose = (label) => {
      const series = found.map((figure, i) => {
        const curve = curves(figure).find((candidate) => candidate.label === label);
        // Dashes let a curve be seen below another.
        return curve && { ...curve, label: runs[i].name, dash: i > 0 ? [8, 3 + 2 * i] : undefined };
      }).filter(Boolean);
      const { unit, log, note } = found.find(Boolean);
      const hasMarks = found.some((figure) => figure?.series.some(({ points }) => points));
      const figure = new Figure({ title: labels.length > 1 ? `${title}: ${label}` : title, unit, log, note: [log && note, hasMarks && UNMARKED].filter(Boolean).join(' ') || null, series, timeUnit: runs[0].units.time, go, events: [] });
      const before = shown.figures[number];
      shown.figures[number] = figure;
      holder.replaceChildren(figure.element);
      if (before) {
        figure.draw({ ...colours(), dark: isDark() });
        if (before.time !== undefined) figure.at(before.time);
      }
    };
    const select = labels.length > 1
      ? element('label', { class: 'choice' }, 'Show ', element('select', { change: ({ target }) => choose(labels[target.value]) },
        labels.map((label, i) => element('option', { value: i }, label))))
      : null;
    choose(labels[0]);
    place.append(element('div', {}, select, holder));
  });
  return place;
}
