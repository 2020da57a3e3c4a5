// SPDX-License-Identifier: MIT
// Many copies of one shape, each deformed by a matrix of its own: domains of particles and arrows.

const source = (points, polys) => {
  const data = vtk.Common.DataModel.vtkPolyData.newInstance();
  data.getPoints().setData(Float32Array.from(points.flat()), 3);
  data.getPolys().setData(Uint32Array.from(polys.flatMap(p => [p.length, ...p])));
  return data;
};

export const square = () => source([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [[0, 1, 2, 3]]);
export const cube = () => source(
  [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]],
  [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [2, 3, 7, 6], [1, 2, 6, 5], [3, 0, 4, 7]]);
export const ball = () => {
  const out = vtk.Filters.Sources.vtkSphereSource.newInstance({ radius: 1, thetaResolution: 12, phiResolution: 8 });
  out.update();
  return out.getOutputData();
};
export const arrow = flat => {
  if (flat) return source([[0, -0.035, 0], [0.7, -0.035, 0], [0.7, -0.12, 0], [1, 0, 0], [0.7, 0.12, 0], [0.7, 0.035, 0], [0, 0.035, 0]],
    [[0, 1, 5, 6], [2, 3, 4]]);
  const out = vtk.Filters.Sources.vtkArrowSource.newInstance({ tipResolution: 12, shaftResolution: 8, tipRadius: 0.11, shaftRadius: 0.032, tipLength: 0.3 });
  out.update();
  return out.getOutputData();
};

// The inverse and transposed matrix, for normals, of the columns a, b, c.
function cofactors(m, at, n, to) {
  const a = m[at], b = m[at + 1], c = m[at + 2], d = m[at + 4], e = m[at + 5], f = m[at + 6], g = m[at + 8], h = m[at + 9], i = m[at + 10];
  const A = e * i - f * h, B = f * g - d * i, C = d * h - e * g, det = a * A + b * B + c * C, s = det ? 1 / det : 0;
  n[to] = A * s; n[to + 1] = B * s; n[to + 2] = C * s;
  n[to + 3] = (h * c - b * i) * s; n[to + 4] = (a * i - c * g) * s; n[to + 5] = (g * b - a * h) * s;
  n[to + 6] = (b * f - e * c) * s; n[to + 7] = (d * c - a * f) * s; n[to + 8] = (a * e - d * b) * s;
}

// Copies in space. vtk.js builds the matrices of its glyphs one by one, which takes seconds for many: this mapper gets them as they are.
const matrixMapper = typeof vtk !== "undefined" ? vtk.macro.newInstance((api, model) => {
  vtk.Rendering.Core.vtkGlyph3DMapper.extend(api, model, {});
  model.cells = { positions: new Float32Array(0), axes: new Float32Array(0), bounds: [0, 1, 0, 1, 0, 1] };
  api.setCells = cells => { model.cells = cells; api.modified(); };
  api.computeBounds = () => { model.bounds = model.cells.bounds; };
  api.getBounds = () => model.cells.bounds;
  api.buildArrays = () => {
    if (model.buildTime.getMTime() >= api.getMTime()) return;
    const { positions, axes, bounds } = model.cells, count = positions.length / 3;
    const m = model.matrixArray = new Float32Array(16 * count), n = model.normalArray = new Float32Array(9 * count);
    for (let i = 0; i < count; ++i) {
      for (let c = 0; c < 3; ++c)
        for (let d = 0; d < 3; ++d) m[16 * i + 4 * c + d] = axes[9 * i + 3 * c + d];
      for (let d = 0; d < 3; ++d) m[16 * i + 12 + d] = positions[3 * i + d];
      m[16 * i + 15] = 1;
      cofactors(m, 16 * i, n, 9 * i);
    }
    model.bounds = bounds;
    const scalars = model.cells.values && vtk.Common.Core.vtkDataArray.newInstance({ values: model.cells.values });
    model.colorArray = scalars ? model.lookupTable.mapScalars(scalars, model.colorMode, 0) : null;
    model.buildTime.modified();
  };
}, "TriboMatrixMapper") : null;

// Copies as the polygons of one surface: graphics in software draw copies of a shape one by one, many times slower.
function surfaceOf(shape, { positions, axes, values }) {
  const corners = shape.getPoints().getData(), faces = shape.getPolys().getData(), count = positions.length / 3;
  const each = corners.length, points = new Float32Array(each * count), polys = new Uint32Array(faces.length * count);
  const shades = values && new Float32Array(facesOf(shape) * count);
  for (let i = 0; i < count; ++i) {
    for (let c = 0; c < each; c += 3)
      for (let d = 0; d < 3; ++d)
        points[each * i + c + d] = positions[3 * i + d] + corners[c] * axes[9 * i + d] + corners[c + 1] * axes[9 * i + 3 + d] + corners[c + 2] * axes[9 * i + 6 + d];
    for (let f = 0, left = 0; f < faces.length; ++f) {
      polys[faces.length * i + f] = left ? faces[f] + each / 3 * i : faces[f];
      left = left ? left - 1 : faces[f];
    }
  }
  if (shades) for (let k = 0, n = facesOf(shape); k < shades.length; ++k) shades[k] = values[Math.floor(k / n)];
  return { points, polys, shades };
}
const facesOf = shape => shape.getPolys().getNumberOfCells();
const mostFaces = 100000;  // of a surface in space, which takes more memory than copies

// An actor of such copies; `show` takes their centres, three half axes each, values for the lookup table, and bounds.
export class Glyphs {
  constructor(renderer, shape) {
    this.copies = { data: vtk.Common.DataModel.vtkPolyData.newInstance(), mapper: matrixMapper() };
    this.surface = { data: vtk.Common.DataModel.vtkPolyData.newInstance(), mapper: vtk.Rendering.Core.vtkMapper.newInstance() };
    for (const { data, mapper } of [this.copies, this.surface]) mapper.setInputData(data, 0);
    this.surface.mapper.setScalarModeToUseCellData();
    this.surface.mapper.setUseLookupTableScalarRange(true);
    this.actor = vtk.Rendering.Core.vtkActor.newInstance();
    this.actor.setMapper(this.surface.mapper);
    this.setShape(shape);
    renderer.addActor(this.actor);
  }
  setShape(shape) {
    this.shape = shape;
    this.flat = shape.getPoints().getData().every((x, k) => k % 3 < 2 || x === 0);
    this.copies.mapper.setInputData(shape, 1);
  }
  show({ positions, axes, values, bounds, table }) {
    const count = positions.length / 3;
    this.isSurface = this.flat || count * facesOf(this.shape) <= mostFaces;
    const { data, mapper } = this.isSurface ? this.surface : this.copies;
    if (table) { mapper.setLookupTable(table); mapper.setColorModeToMapScalars(); }
    mapper.setScalarVisibility(Boolean(values));
    if (this.isSurface) {
      const { points, polys, shades } = surfaceOf(this.shape, { positions, axes, values });
      data.getPoints().setData(points, 3);
      data.getPolys().setData(polys);
      data.getCellData().setScalars(shades ? vtk.Common.Core.vtkDataArray.newInstance({ name: "shade", values: shades }) : null);
    } else {
      data.getPoints().setData(positions, 3);
      mapper.setCells({ positions, axes, values, bounds });
    }
    data.modified();
    this.actor.setMapper(mapper);
    this.actor.getProperty().setInterpolation(this.isSurface && !this.flat ? 0 : 1);  // a surface has no normals: each face has its own
    this.actor.setVisibility(count > 0);
  }
  // The copy that a selection has found.
  copyOf({ compositeID, attributeID }) { return this.isSurface ? Math.floor(attributeID / facesOf(this.shape)) : compositeID; }
}
