"""A dozer with a six-way blade."""
