// SPDX-License-Identifier: MIT
// Colour maps of fields, and the colours of materials.

const Core = () => vtk.Rendering.Core;

export const maps = {
  "viridis": "Viridis (matplotlib)", "inferno": "Inferno (matplotlib)", "magma": "Magma (matplotlib)", "plasma": "Plasma (matplotlib)",
  "cool to warm": "Cool to Warm", "rainbow": "Rainbow Desaturated", "jet": "jet", "black body": "Black-Body Radiation",
  "blue, white, red": "BuRd", "grey": "Grayscale"
};

export const stone = [186, 184, 178];
const distinct = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [240, 228, 66],
  [110, 110, 110], [150, 90, 60], [180, 180, 180]];
export const colourOf = number => distinct[((Math.round(number) - 1) % 10 + 10) % 10];
export const css = colour => `rgb(${colour.join(",")})`;

// More categories than this, such as the numbers of particles, are a scale.
const mostCategories = 2000;
export const isCategory = head => head.integers && head.range[1] - head.range[0] < mostCategories;

// The table of a scale, or of categories.
export function lookupTable(head, range, { map, reversed }) {
  const table = Core().vtkColorTransferFunction.newInstance();
  if (isCategory(head)) {
    for (let k = Math.floor(range[0]); k <= Math.ceil(range[1]); ++k) {
      const [r, g, b] = colourOf(k).map(c => c / 255);
      table.addRGBPoint(k - 0.5, r, g, b);
      table.addRGBPoint(k + 0.499, r, g, b);
    }
    table.setMappingRange(Math.floor(range[0]) - 0.5, Math.ceil(range[1]) + 0.499);
  } else {
    const preset = { ...Core().vtkColorTransferFunction.vtkColorMaps.getPresetByName(maps[map]) };
    if (reversed) preset.RGBPoints = turned(preset.RGBPoints);
    table.applyColorMap(preset);
    // Between the points of a dense map nothing is to be bent: its own colour space does so where hues turn.
    if (preset.RGBPoints.length > 400) table.setColorSpace(Core().vtkColorTransferFunction.ColorSpace.RGB);
    table.setMappingRange(...range);
  }
  table.setNanColor(...stone.map(c => c / 255), 1);
  table.updateRange();
  return table;
}

function turned(points) {
  const low = points[0], high = points[points.length - 4], out = [];
  for (let k = points.length - 4; k >= 0; k -= 4) out.push(low + high - points[k], points[k + 1], points[k + 2], points[k + 3]);
  return out;
}
