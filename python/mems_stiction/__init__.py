"""What people read of predictions: text and pictures. The figures themselves come from the C++ core."""
