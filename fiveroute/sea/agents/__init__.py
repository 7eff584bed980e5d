"""AUVs that know only what reached them: their messages, the channel, auctions and consensus."""
