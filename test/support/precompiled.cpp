/// The unit behind the precompiled header, which the tests share.
