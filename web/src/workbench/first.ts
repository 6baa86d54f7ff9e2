// SPDX-License-Identifier: BSD-3-Clause
/** The example that a page opens with. */
export const first = "jansen-leg";
