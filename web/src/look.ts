// How the curves of one diagram are told apart.
export const strokes = ["--c0", "--c5", "--c2", "--c3", "--c1", "--c4"]; // variables of the page
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [5, 2], [1, 2]];

/** Colour and dash of a curve, as in the printed form (plot_svg.cpp): the first 36 differ in one of them. */
export const lookOf = (index: number): { stroke: string; dash: number[] } => ({
  stroke: strokes[index % strokes.length],
  dash: dashes[(index + Math.floor(index / strokes.length)) % dashes.length],
});

/** More curves than this are one bundle: one colour, no legend, a name where one points. */
export const mostNamed = 7;
