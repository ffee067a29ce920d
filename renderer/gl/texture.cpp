// The GL side: filled in below.
