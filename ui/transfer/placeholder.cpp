// The transfer function editor comes here.
