"""The arena that pages look at: what runs, what people ask of it, what they are told."""
