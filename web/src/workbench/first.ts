/** The example that a page opens with. */
export const first = "jansen-leg";
