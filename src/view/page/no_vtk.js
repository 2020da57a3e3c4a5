// Built without vtk.js: the page shows pictures.
