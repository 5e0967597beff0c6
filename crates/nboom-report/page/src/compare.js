// Several runs on the same axes: one curve for each run.

import { figuresOf } from './curves.js';
import { Figure } from './plot.js';
import { element } from './text.js';
import { colours, isDark } from './theme.js';

/** What notes of runs say: once if all say the same, else by run. */
function noteOf(figures, runs) {
  const notes = figures.map((figure, i) => ({ run: runs[i], note: figure?.note })).filter(({ note }) => note);
  const said = new Set(notes.map(({ note }) => note));
  return said.size > 1 ? notes.map(({ run, note }) => `${run.name}: ${note}`).join(' ') : [...said].join('');
}

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
      const chosen = found.map((figure, i) => ({ figure, run: runs[i], i, at: curves(figure).findIndex((curve) => curve.label === label) }))
        .filter(({ at }) => at >= 0);
      // Dashes let a curve be seen below another.
      const lines = chosen.map(({ figure, run, i, at }) => ({ ...curves(figure)[at], label: run.name, dash: i > 0 ? [8, 3 + 2 * i] : undefined }));
      const marks = chosen.flatMap(({ figure, run, at }, line) => figure.series.filter(({ points, of }) => points && of === at)
        .map((mark) => ({ ...mark, label: `${run.name}: ${mark.label}`, of: line })));
      const { unit, log } = found.find(Boolean);
      const figure = new Figure({ title: labels.length > 1 ? `${title}: ${label}` : title, unit, log, note: noteOf(found, runs), series: [...lines, ...marks], timeUnit: runs[0].units.time, go, events: [] });
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
