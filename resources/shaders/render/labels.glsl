// Labels between voxels. Needs solver/paging.glsl and solver/volume_blocks.glsl.

uniform usampler2DArray labels;       // 0: nothing
uniform sampler2DArray label_lacks;   // how much of what is around a voxel has another label than it
uniform isampler3D label_table;       // of both
uniform uint visible_labels[8];       // a bit for each label that is seen
uniform sampler2D label_colours;      // by label, 256 in a row
uniform float label_opacity;

vec3 colour_of_label(int label) {
  return texelFetch(label_colours, ivec2(label, 0), 0).rgb;
}

ivec3 label_texel(ivec3 voxel) {
  return texel_in_blocks(label_table, clamp(voxel, ivec3(0), volume_size - 1));
}

// 0 where the label is hidden, too.
int label_at(ivec3 texel) {
  int label = int(texelFetch(labels, texel, 0).r);
  return (visible_labels[label >> 5] >> uint(label & 31) & 1u) != 0u ? label : 0;
}
int label_of(ivec3 voxel) { return label_at(label_texel(voxel)); }

// What the voxels around p say of a label.
struct LabelShare {
  float share;  // above a half where p has the label
  int other;    // the nearest voxel's that has another one
};

LabelShare share_of(int label, vec3 p) {
  ivec3 low = ivec3(floor(p));
  vec3 f = p - vec3(low);
  LabelShare sum = LabelShare(0.0, label);
  float most = 0.0;
  for (int i = 0; i < 8; ++i) {
    ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
    vec3 along = mix(1.0 - f, f, vec3(corner));
    float weight = along.x * along.y * along.z;
    ivec3 texel = label_texel(low + corner);
    int there = label_at(texel);
    float own = 1.0 - texelFetch(label_lacks, texel, 0).r;
    // Where two labels meet, what one has not is the other's.
    sum.share += weight * (there == label ? own : 1.0 - own);
    sum.other = there != label && weight > most ? there : sum.other;
    most = there != label ? max(most, weight) : most;
  }
  return sum;
}

int label_between(vec3 p) {
  ivec3 texel = label_texel(ivec3(floor(p + 0.5)));
  int nearest = label_at(texel);
  // All voxels around have the same label.
  if (texelFetch(label_lacks, texel, 0).r == 0.0) return nearest;
  LabelShare found = share_of(nearest, p);
  return found.share >= 0.5 ? nearest : found.other;
}

// d (share of the label) / d voxel at p, from differences over a voxel to each side.
vec3 label_slope(int label, vec3 p) {
  const vec2 h = vec2(1.0, 0.0);
  return vec3(share_of(label, p + h.xyy).share - share_of(label, p - h.xyy).share,
              share_of(label, p + h.yxy).share - share_of(label, p - h.yxy).share,
              share_of(label, p + h.yyx).share - share_of(label, p - h.yyx).share);
}
