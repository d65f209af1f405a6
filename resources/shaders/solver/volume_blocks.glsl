// Volumes of which only some blocks of 8^3 voxels are there (solver/gl/volume_blocks.h). A table has each block's tile, in
// which texels lie as solver/paging.glsl has those of a page; tile 0 is that of all blocks that are not there.
//
// BLOCK_TILE_COLUMNS, BLOCKS_PER_ROW, BLOCK_ROWS_PER_LAYER: as TILE_COLUMNS, PAGES_PER_ROW, ROWS_PER_LAYER there. Without
// them no volume is in blocks.

#ifdef BLOCKS_PER_ROW
const int kBlock = 8;
const ivec2 kBlockTile = kBlock * ivec2(BLOCK_TILE_COLUMNS, kBlock / BLOCK_TILE_COLUMNS);

ivec3 texel_in_blocks(highp isampler3D table, ivec3 voxel) {
  int tile = texelFetch(table, voxel / kBlock, 0).r;
  int row = tile / BLOCKS_PER_ROW;
  int layer = row / BLOCK_ROWS_PER_LAYER;
  ivec2 origin = ivec2(tile - row * BLOCKS_PER_ROW, row - layer * BLOCK_ROWS_PER_LAYER) * kBlockTile;
  ivec3 local = voxel % kBlock;
  return ivec3(origin + local.xy + kBlock * ivec2(local.z % BLOCK_TILE_COLUMNS, local.z / BLOCK_TILE_COLUMNS), layer);
}
#endif
