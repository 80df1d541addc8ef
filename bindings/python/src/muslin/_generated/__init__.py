"""What is generated from include/muslin.h."""
