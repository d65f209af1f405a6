// Address translation (paper section 3.2): where a voxel's values lie in physical memory G.
//
// From the page layout: PAGE_X, PAGE_Y, PAGE_Z, a page's shape; TILE_COLUMNS, how many slices of a page lie side
// by side in G (the others follow below); PAGES_PER_ROW, how many pages lie side by side in G; ROWS_PER_LAYER, how many
// such rows a layer of G has. Kernels speak of voxels and of places in a page; nothing but this file knows how they are
// laid out.

const ivec3 kPageShape = ivec3(PAGE_X, PAGE_Y, PAGE_Z);
const ivec2 kTile = ivec2(PAGE_X * TILE_COLUMNS, PAGE_Y * (PAGE_Z / TILE_COLUMNS));

// Physical pages that stand for everything that is not resident.
const int kOutsidePage = 0;
const int kInsidePage = 1;
const int kFirstPage = 2;

uniform ivec3 volume_size;  // voxels
uniform ivec3 page_grid;    // V_P's size, in pages

bool contains_page(ivec3 page) {
  return all(greaterThanEqual(page, ivec3(0))) && all(lessThan(page, page_grid));
}

// The virtual page number (VPN) of a page of V_P, and back.
int page_number(ivec3 page) {
  return page.x + page_grid.x * (page.y + page_grid.y * page.z);
}
ivec3 page_coordinates(int number) {
  int row = number / page_grid.x;
  return ivec3(number - row * page_grid.x, row % page_grid.y, row / page_grid.y);
}

// The first texel of a physical page with its layer, and a voxel's texel counted from there.
ivec3 page_origin(int physical) {
  int row = physical / PAGES_PER_ROW;
  int layer = row / ROWS_PER_LAYER;
  return ivec3(ivec2(physical - row * PAGES_PER_ROW, row - layer * ROWS_PER_LAYER) * kTile, layer);
}
ivec3 texel_in_page(ivec3 local) {
  return ivec3(local.x + PAGE_X * (local.z % TILE_COLUMNS), local.y + PAGE_Y * (local.z / TILE_COLUMNS), 0);
}
// The texel of that number in a page's tile, and back.
ivec3 texel_of_tile(int number) {
  return ivec3(number % kTile.x, number / kTile.x, 0);
}
int number_in_tile(ivec2 texel) { return texel.x + kTile.x * texel.y; }

// Where layers follow each other along y: the height of a full one, and the first texel of a page by its column and row
// among pages, 16 bits each.
const int kLayerHeight = ROWS_PER_LAYER * kTile.y;
ivec2 texel_of_page(int column_and_row) {
  return ivec2(column_and_row & 0xffff, column_and_row >> 16 & 0xffff) * kTile;
}
