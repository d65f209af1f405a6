// How a slice lies in the volume. SLICE_AXIS is the axis across which slices are cut; the other two are a slice's
// own, in their order.

#if SLICE_AXIS == 0
#define ALONG x
#define ACROSS yz
#elif SLICE_AXIS == 1
#define ALONG y
#define ACROSS xz
#else
#define ALONG z
#define ACROSS xy
#endif
