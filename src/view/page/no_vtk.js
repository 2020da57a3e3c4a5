// SPDX-License-Identifier: MIT
// Built without vtk.js: the page shows pictures.
